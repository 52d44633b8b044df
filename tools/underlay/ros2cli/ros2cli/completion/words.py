# SPDX-License-Identifier: Apache-2.0
"""Complete words from fixed lists."""

from __future__ import annotations

import argparse

TRANSITIONS = ('activate', 'cleanup', 'configure', 'deactivate', 'shutdown')


def transitions(prefix: str, args: argparse.Namespace) -> tuple[str, ...]:
    """
    List the lifecycle transitions that users can request.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    return TRANSITIONS
