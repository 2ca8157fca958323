// palp with the command `listen` alone: the same code as in palp, without what its pictures need.

#include "app/cli/Cli.h"

int main(int argc, char** argv) {
  palp::Cli cli;
  palp::addListen(cli);
  return cli.main(argc, argv);
}
