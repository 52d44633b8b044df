# SPDX-License-Identifier: Apache-2.0
"""A page in the browser, for who may see it."""

from __future__ import annotations

from dataclasses import replace
import ipaddress
import secrets
import socket
from types import TracebackType
from urllib.parse import urlencode

import rich
from rviz_common.page.admission import Admission
from rviz_common.page.listening import listen
from rviz_common.page.routes import Routes
from rviz_common.page.settings import PageSettings
import viser

__all__ = ['Page']


class Page:
    """A page with a scene and widgets, which are those of `viser`."""

    def __init__(self, title: str, settings: PageSettings | None = None) -> None:
        """Serve an empty page, or raise PortError."""
        from rviz_common.page.gate import gated

        settings = settings or PageSettings()
        if not settings.is_local and not settings.token:
            settings = replace(settings, token=secrets.token_urlsafe(16))
        rich.get_console().quiet = True  # viser prints addresses, but not the token
        bound = listen(settings)
        self.settings = settings
        self.port: int = bound.getsockname()[1]
        self.routes = Routes()
        admission = Admission(self.port, settings.token)
        with gated(bound, title, admission, self.routes):
            self.viser = viser.ViserServer(
                host=settings.host, port=self.port, label=title, verbose=False
            )
        self.viser.gui.configure_theme(
            control_width='large',
            dark_mode=True,
            show_logo=False,
            show_share_button=False,
        )
        self.viser.gui.main_panel.dock_right()
        # Shadows halve the frames where the processor draws.
        self.viser.scene.configure_default_lights(cast_shadow=False)

    @property
    def url(self) -> str:
        """Return the address to open, with the token if there is one."""
        address = _reachable(self.settings.host)
        host = f'[{address}]' if ':' in address else address
        query = f'?{urlencode({"token": self.settings.token})}' if self.settings.token else ''
        return f'http://{host}:{self.port}/{query}'

    def close(self) -> None:
        """Serve no longer."""
        self.viser.stop()

    def __enter__(self) -> Page:
        """Return the page."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the page."""
        self.close()


def _reachable(host: str) -> str:
    """Return an address that can be opened; a host may mean all addresses of this machine."""
    address = ipaddress.ip_address(host)
    if not address.is_unspecified:
        return host
    family, test_net = (
        (socket.AF_INET, '192.0.2.1') if address.version == 4 else (socket.AF_INET6, '2001:db8::1')
    )
    with socket.socket(family, socket.SOCK_DGRAM) as asking:
        try:
            asking.connect((test_net, 9))  # sends nothing, but chooses the address
        except OSError:
            return '127.0.0.1' if address.version == 4 else '::1'
        return str(asking.getsockname()[0])
