# SPDX-License-Identifier: Apache-2.0
"""Complete words that are always the same."""

from __future__ import annotations

import argparse

TRANSITIONS = ('activate', 'cleanup', 'configure', 'deactivate', 'shutdown')


def transitions(prefix: str, args: argparse.Namespace) -> tuple[str, ...]:
    """Return the transitions of a lifecycle node that users ask for."""
    return TRANSITIONS
