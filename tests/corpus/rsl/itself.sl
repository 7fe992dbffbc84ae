#include "itself.sl"
surface a() {}
