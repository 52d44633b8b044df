# SPDX-License-Identifier: Apache-2.0
"""One-time codes by which a person confirms a single call of an assistant."""

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
"""Characters that are not mistaken for one another."""
_LENGTH = 6


@dataclass
class _Pending:
    """A pending code, its expiry time, and the number of wrong attempts."""

    code: str
    until_s: float
    wrong: int = 0


def request_of(tool: str, arguments: Mapping[str, Any]) -> str:
    """
    Serialise a call, to which a code is bound: exactly this tool with these arguments.

    Parameters
    ----------
    tool, arguments
        The name of the tool, and the arguments as sent.

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
    Issuer of one-time codes, each for one request, with a lifetime and a limit of attempts.

    Parameters
    ----------
    now_s
        Returns the time of a steady clock (s).
    make
        Generates a code.

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
        Issue a code for a request; it invalidates an earlier one for the same request.

        Parameters
        ----------
        request
            The request that the code allows.

        Returns
        -------
        str
            A code that is valid for 180 s; beyond eight codes, the oldest are invalidated.

        """
        self._pending.pop(request, None)
        while len(self._pending) >= _MOST:
            del self._pending[next(iter(self._pending))]
        code = self._make()
        self._pending[request] = _Pending(code, self._now_s() + _LIFETIME_S)
        return code

    def redeem(self, code: str, request: str) -> bool:
        """
        Validate a code for a request. The right code works once; three wrong ones invalidate it.

        Parameters
        ----------
        code
            The code as typed; case and surrounding spaces do not matter.
        request
            The request to allow.

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
        """Invalidate all codes."""
        self._pending.clear()
