#define l0 x
#define l1 l0 l0 l0 l0 l0 l0 l0 l0 l0 l0
#define l2 l1 l1 l1 l1 l1 l1 l1 l1 l1 l1
#define l3 l2 l2 l2 l2 l2 l2 l2 l2 l2 l2
#define l4 l3 l3 l3 l3 l3 l3 l3 l3 l3 l3
#define l5 l4 l4 l4 l4 l4 l4 l4 l4 l4 l4
#define l6 l5 l5 l5 l5 l5 l5 l5 l5 l5 l5
l6