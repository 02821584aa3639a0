"""python3 -m corank.cluster"""

import sys

if __name__ == "__main__":  # not in the worker processes, which import this file anew
    from . import forks

    if forks.are_wanted(sys.argv[1:]):
        forks.begin()
    from .command import main

    sys.exit(main())
