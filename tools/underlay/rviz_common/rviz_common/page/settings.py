# SPDX-License-Identifier: Apache-2.0
"""Where a page is served, and to whom."""

from __future__ import annotations

from dataclasses import dataclass
import ipaddress

__all__ = ['FIRST_PORT', 'NO_TOKEN', 'PARAMETERS', 'PageSettings']

FIRST_PORT = 8080
NO_TOKEN = 'none'
"""The token that means: admit whoever is on this machine."""
PARAMETERS: dict[str, tuple[str | int, str]] = {
    'host': ('127.0.0.1', 'The address at which the page is served.'),
    'port': (0, 'The port of the page; 0: the first free one from 8080 on.'),
    'token': ('', 'What must be known to open the page; made up if empty, "none" for none.'),
}
"""What the parameters of a node with a page are called: their defaults, and what they mean."""


@dataclass(frozen=True)
class PageSettings:
    """
    Where a page is served, and to whom.

    Without a port the first free one from 8080 on is taken. The page is only shown to who knows
    the token, as any user of this machine could open it otherwise, and any program; one is made
    up if none is given. `NO_TOKEN` does without, on an address that only this machine reaches.
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
        if self.token == NO_TOKEN and not self.is_local:
            raise ValueError(
                f"The token is 'none', but other machines reach {self.host}: everybody there "
                'could drive the robot. Choose a token, as in token:=TEXT, or host:=127.0.0.1.'
            )

    @property
    def is_local(self) -> bool:
        """Tell if only this machine can reach the page."""
        return ipaddress.ip_address(self.host).is_loopback
