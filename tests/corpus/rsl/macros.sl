#define s(x) #x
#define x(x) s(x)
#define c(a, ...) a ## __VA_ARGS__ c(a)
x("\\" 'q' ) c(1,2,3) c(,) c() f ( x
#define f(a) a*g
#define g(a) f(a)
f(2)(9)
__LINE__ __FILE__
#undef f
#line 7 "x"
#pragma nolint
#ifdef f
"