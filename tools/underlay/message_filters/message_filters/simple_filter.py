# SPDX-License-Identifier: Apache-2.0
"""Base of all filters: the callbacks that get its output."""

# ruff: noqa: N802
from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ['SimpleFilter']


class SimpleFilter:
    """Base class of filters: `registerCallback` connects the next filter or a function."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., object], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., object], *args: Any) -> int:
        """
        Call a function with each output of this filter.

        Parameters
        ----------
        cb
            The function. It is called with the messages of the output, then with `args`.
        *args
            Further arguments for it.

        Returns
        -------
        int
            The key of the function in `callbacks`.

        """
        key = max(self.callbacks, default=-1) + 1
        self.callbacks[key] = (cb, args)
        return key

    def signalMessage(self, *msg: Any) -> None:
        """
        Pass an output on to all registered functions.

        Parameters
        ----------
        *msg
            The messages.

        """
        for cb, args in list(self.callbacks.values()):
            cb(*msg, *args)
