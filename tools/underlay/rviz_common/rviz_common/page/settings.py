# SPDX-License-Identifier: Apache-2.0
"""Where a page is served, and to whom."""

from __future__ import annotations

from dataclasses import dataclass
import ipaddress

__all__ = ['FIRST_PORT', 'PageSettings']

FIRST_PORT = 8080


@dataclass(frozen=True)
class PageSettings:
    """
    Where a page is served, and to whom.

    Without a port the first free one from 8080 on is taken. A page that other machines can reach
    is only shown to who knows the token; one is made up if none is given.
    """

    host: str = '127.0.0.1'
    port: int | None = None
    token: str = ''

    def __post_init__(self) -> None:
        """Refuse what cannot be an address or a port."""
        try:
            ipaddress.ip_address(self.host)
        except ValueError:
            raise ValueError(
                f"The host is '{self.host}', but must be an address of this machine, such as "
                '127.0.0.1, or 0.0.0.0 for all of them.'
            ) from None
        if self.port is not None and not 1 <= self.port <= 65535:
            raise ValueError(f'The port is {self.port}, but must be from 1 to 65535.')

    @property
    def is_local(self) -> bool:
        """Tell if only this machine can reach the page."""
        return ipaddress.ip_address(self.host).is_loopback
