#include "itself.sl"
