# SPDX-License-Identifier: Apache-2.0
"""Set the workspace up, or build it: `python3 tools/setup COMMAND`, which commands.py lists.

This file and prerequisites.py parse under any Python 3, so that a wrong version gets a message
instead of a syntax error.
"""

import sys
from typing import List

import prerequisites


def main(argv: List[str]) -> int:
    """
    Check the version of Python, run a command of the set-up, and return its exit status.

    Parameters
    ----------
    argv
        Command-line arguments, without the name of the program.

    """
    problem = prerequisites.python_problem()
    if problem:
        sys.stderr.write(problem + '\n')
        return 1
    import commands

    return commands.main(argv)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
