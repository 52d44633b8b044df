# SPDX-License-Identifier: Apache-2.0
"""A node that publishes a text with a number once per second, in the main executor."""

from __future__ import annotations

import sys

from demo_nodes_py.topics.talker import main, Talker

__all__ = ['Talker', 'main']


if __name__ == '__main__':
    sys.exit(main())
