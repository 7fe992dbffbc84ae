#include "reyes/app/commands/command.h"

int main(int argc, char** argv) { return tomales::run(argc, argv); }
