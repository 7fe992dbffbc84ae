/* Every construct of the language once. */
#define SQR(x) ((x) * (x))
#define NAME(a, b) a##b
float twice(float x) { return 2 * x; }
void split(vector v; output float a, b) { a = xcomp(v); b = ycomp(v); }
/* A surface with everything. */
surface all(float Ks = .5, Kd = 1.; uniform color tint = color "hsv" (.1, .2, 1); string map = "";
            point at = point "shader" (0, 0, 0); float list[3] = {1, 2, 3}; output varying float out = 0;) {
  extern point P;
  uniform float i, total = 0;
  float inner(float y) { extern float total; return y + total; }
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I), W = V ^ Nf;
  matrix m = matrix "shader" (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  for (i = 0, total = 1; i < 3; i += 1) { if (list[i] > 1 && !(i == 2)) continue; else total *= list[i]; }
  while (1 == 1) { while (total >= 0) break 2; }
  illuminance("-glossy", P, Nf, PI / 2) { Ci += Cl * (normalize(L) . Nf); }
  gather("", P, Nf, .1, 4, "surface:Ci", tint) total += 1; else total -= 1;
  out = map == "" ? float noise(P) : float texture(map[0], s, t, "blur", 1e-3);
  Ci = tint * SQR(twice(out)) + color noise(NAME(P, )) * 2;
  W /= 2; V -= W;
  return;
}
