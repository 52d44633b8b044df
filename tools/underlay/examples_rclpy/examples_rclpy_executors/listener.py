# SPDX-License-Identifier: Apache-2.0
"""A node that logs what the talker publishes, in the main executor."""

from __future__ import annotations

import sys

from demo_nodes_py.topics.listener import Listener, main

__all__ = ['Listener', 'main']


if __name__ == '__main__':
    sys.exit(main())
