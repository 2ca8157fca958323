#include "app/cli/Cli.h"
#include "app/study/Failure.h"

#include <csignal>
#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a file above the limit is refused by a message, as a full disk is
  std::signal(SIGCHLD, SIG_DFL); // ignored by some who start us: our own processes' ends would be lost
  try {
    palp::Cli cli;
    palp::addDesign(cli);
    palp::addMaterial(cli);
    palp::addMesh(cli);
    palp::addSolve(cli);
    palp::addRender(cli);
    palp::addSample(cli);
    palp::addMerge(cli);
    palp::addImport(cli);
    palp::addStudy(cli);
    palp::addCluster(cli);
    palp::addReproduce(cli);
    palp::addTrain(cli);
    palp::addPredict(cli);
    palp::addSweep(cli);
    palp::addReport(cli);
    palp::addListen(cli);
    palp::addCalibrate(cli);
    return cli.main(argc, argv);
  } catch (...) { // the last resort: a mistake of ours, not of the user's
    std::cerr << "palp: " << palp::failureInWords(std::current_exception()) << '\n';
    return static_cast<int>(palp::Exit::NoResult);
  }
}
