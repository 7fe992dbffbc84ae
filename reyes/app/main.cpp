#include "reyes/app/command.h"
#include "reyes/base/deep_stack.h"

int main(int argc, char** argv) {
  int code = 0;
  tomales::runOnDeepStack([&] { code = tomales::run(argc, argv); });
  return code;
}
