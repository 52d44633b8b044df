# SPDX-License-Identifier: Apache-2.0
"""Codes by which a person lets a single call of an assistant happen."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
import json
import secrets
import time
from typing import Any

__all__ = ['Confirmations', 'request_of']

_LIFETIME_S = 180.0
_MOST = 8
_MOST_WRONG = 3
_LETTERS = 'ABCDEFGHJKLMNPQRSTUVWXYZ23456789'
"""Those that nobody mistakes for another one."""
_LENGTH = 6


@dataclass
class _Pending:
    """A code, what it allows, and until when."""

    code: str
    until_s: float
    wrong: int = 0


def request_of(tool: str, arguments: Mapping[str, Any]) -> str:
    """
    Serialise a call, as what a code is good for: exactly this tool with these arguments.

    Parameters
    ----------
    tool, arguments
        The name of the tool, and what was sent to it.

    Returns
    -------
    str
        JSON, the same for any order of the arguments.

    """
    return json.dumps([tool, dict(arguments)], sort_keys=True)


def _random_code() -> str:
    return ''.join(secrets.choice(_LETTERS) for _ in range(_LENGTH))


class Confirmations:
    """
    Gives codes, each good once, for one request, for some minutes, against few guesses.

    Parameters
    ----------
    now_s
        A clock that nobody sets (s).
    make
        Makes a code.

    """

    def __init__(
        self,
        now_s: Callable[[], float] = time.monotonic,
        make: Callable[[], str] = _random_code,
    ) -> None:
        self._now_s, self._make = now_s, make
        self._pending: dict[str, _Pending] = {}

    def ask(self, request: str) -> str:
        """
        Issue a code for a request; an earlier one for the same request is void then.

        Parameters
        ----------
        request
            What the code is to allow.

        Returns
        -------
        str
            A code that is valid for 180 s; of more than eight, the oldest are void.

        """
        self._pending.pop(request, None)
        while len(self._pending) >= _MOST:
            del self._pending[next(iter(self._pending))]
        code = self._make()
        self._pending[request] = _Pending(code, self._now_s() + _LIFETIME_S)
        return code

    def redeem(self, code: str, request: str) -> bool:
        """
        Check a code for a request. A right code works once, and three wrong ones make it void.

        Parameters
        ----------
        code
            What was typed; small letters and spaces around it do not matter.
        request
            What it is to allow.

        Returns
        -------
        bool
            Whether the code is right and still valid.

        """
        pending = self._pending.get(request)
        if pending is None:
            return False
        is_right = secrets.compare_digest(code.strip().upper().encode(), pending.code.encode())
        pending.wrong += not is_right
        is_over = self._now_s() > pending.until_s
        if is_right or is_over or pending.wrong >= _MOST_WRONG:
            del self._pending[request]
        return is_right and not is_over

    def forget(self) -> None:
        """Make all codes worthless."""
        self._pending.clear()
