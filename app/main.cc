// A program: the command line corank, or one in the manner of the CUIK suite. Everything that a run prints is printed in
// app/, nothing below it.
#include <csignal>

#include "corank/app/run.h"

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that reaches the limit of size is an error of writing, like a full disk
  return corank::app::run_program(CORANK_PROGRAM, {argv + (argc > 0 ? 1 : 0), argv + argc});
}
