// corank: the command line. Everything that a run prints is printed in app/, nothing below it.
#include "corank/app/run.h"

int main(int argc, char** argv) { return corank::app::run("corank", {argv + (argc > 0 ? 1 : 0), argv + argc}); }
