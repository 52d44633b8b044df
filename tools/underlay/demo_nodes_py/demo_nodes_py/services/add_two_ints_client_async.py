# SPDX-License-Identifier: Apache-2.0
"""
The executable `add_two_ints_client_async`.

The genuine package shows two ways of waiting for a response. Here both clients wait in a
coroutine, so that one implementation serves both names.
"""

from __future__ import annotations

import sys

from demo_nodes_py.services.add_two_ints_client import main

__all__ = ['main']


if __name__ == '__main__':
    sys.exit(main())
