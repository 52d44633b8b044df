# SPDX-License-Identifier: Apache-2.0
"""Complete words that are always the same."""

from __future__ import annotations

import argparse

TRANSITIONS = ('activate', 'cleanup', 'configure', 'deactivate', 'shutdown')


def transitions(prefix: str, args: argparse.Namespace) -> tuple[str, ...]:
    """
    List the transitions of a lifecycle node that users request.

    Parameters
    ----------
    prefix, args
        The word so far and the parsed line, neither of which matters.

    """
    return TRANSITIONS
