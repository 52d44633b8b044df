# SPDX-License-Identifier: Apache-2.0
"""Where a page is served, and to whom."""

from __future__ import annotations

from dataclasses import dataclass
import ipaddress

__all__ = ['FIRST_PORT', 'NO_TOKEN', 'PARAMETERS', 'PageSettings']

FIRST_PORT = 8080
NO_TOKEN = 'none'
"""The value of the token that disables it: all users of this machine are admitted."""
PARAMETERS: dict[str, tuple[str | int, str]] = {
    'host': ('127.0.0.1', 'The address at which the page is served.'),
    'port': (0, 'The port of the page; 0: the first free one from 8080 on.'),
    'token': ('', 'What must be known to open the page; made up if empty, "none" for none.'),
}
"""The ROS parameters of a node with a page: names, defaults and descriptions."""


@dataclass(frozen=True)
class PageSettings:
    """
    Where a page is served, and to whom.

    Without a port, the first free one from 8080 on is used. A token is required to open the page,
    as any user or program on this machine could open it otherwise; one is generated if none is
    given. `NO_TOKEN` disables the token, on a loopback address only.
    """

    host: str = '127.0.0.1'
    port: int | None = None
    token: str = ''

    def __post_init__(self) -> None:
        """Validate the host and the port."""
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
        """Whether only this machine can reach the page."""
        return ipaddress.ip_address(self.host).is_loopback
