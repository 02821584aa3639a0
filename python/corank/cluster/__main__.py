"""python3 -m corank.cluster"""

import sys

if __name__ == "__main__":  # not in the worker processes, which import this file anew
    from .command import main

    sys.exit(main())
