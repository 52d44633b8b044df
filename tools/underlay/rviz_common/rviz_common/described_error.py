# SPDX-License-Identifier: Apache-2.0
"""Describe an error together with its origin."""

from __future__ import annotations

__all__ = ['described_error']


def described_error(error: Exception) -> str:
    """
    Format an error with the file and line where it was raised, and its type.

    Parameters
    ----------
    error
        The error; without a traceback, the file and line are left out.

    """
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    place = '' if trace is None else f'{trace.tb_frame.f_code.co_filename}:{trace.tb_lineno}: '
    return f'{place}{type(error).__name__}: {error}'
