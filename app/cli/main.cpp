#include "app/cli/Cli.h"

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  try {
    palp::Cli cli;
    palp::addDesign(cli);
    palp::addMesh(cli);
    palp::addSolve(cli);
    palp::addRender(cli);
    palp::addSample(cli);
    palp::addMerge(cli);
    palp::addReproduce(cli);
    palp::addTrain(cli);
    palp::addPredict(cli);
    palp::addSweep(cli);
    palp::addReport(cli);
    palp::addListen(cli);
    palp::addCalibrate(cli);
    return cli.main(argc, argv);
  } catch (const std::exception& unexpected) { // the last resort: a mistake of ours, not of the user's
    std::cerr << "palp: internal error: " << unexpected.what() << '\n';
    return static_cast<int>(palp::Exit::NoResult);
  }
}
