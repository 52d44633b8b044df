# SPDX-License-Identifier: Apache-2.0
"""Program that deactivates controllers, and unloads them."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import sys

from controller_manager._program import add_manager_arguments, node_of, parse, run
from controller_manager.spawner import unload

__all__ = ['main']


def main(args: Sequence[str] | None = None) -> int:
    """
    Unload the controllers that the command line names.

    Parameters
    ----------
    args
        The command line, including the program name; by default that of the process.

    Returns
    -------
    int
        The exit status.

    """
    parser = argparse.ArgumentParser('unspawner', description=__doc__)
    parser.add_argument('controller_names', nargs='+', help='names of the controllers')
    add_manager_arguments(parser)
    options = parse(parser, args)

    def work() -> bool:
        with node_of(f'unspawner_{options.controller_names[0]}', options.words) as node:
            return unload(node, options)

    return run(work)


if __name__ == '__main__':
    sys.exit(main())
