#include "reyes/app/command.h"

int main(int argc, char** argv) { return tomales::run(argc, argv); }
