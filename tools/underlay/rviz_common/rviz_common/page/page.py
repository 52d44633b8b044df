# SPDX-License-Identifier: Apache-2.0
"""A page in the browser, with access control."""

from __future__ import annotations

from dataclasses import replace
import secrets
from types import TracebackType
from urllib.parse import urlencode

import rich
from rviz_common.page.address import listen, NO_TOKEN, PageSettings, reachable
from rviz_common.page.admission import Admission
from rviz_common.page.routes import Routes
from rviz_common.page.uploads import Uploads
import viser
from viser._messages import FileTransferPartAck, FileTransferStartUpload, RemoveNotificationMessage

__all__ = ['Page']


class Page:
    """
    A page with a scene and widgets of `viser`; it is served from the start.

    Parameters
    ----------
    title
        The title of the browser's tab.
    settings
        The host, the port and the token; by default it is served at 127.0.0.1. An empty token is
        replaced by a generated one.

    Raises
    ------
    PortError
        The host or the port cannot be used.
    RuntimeError
        This version of viser starts its server in a way that cannot be secured.

    Attributes
    ----------
    port
        The port at which it is served.
    routes
        Routes served in addition to the page itself.
    uploads
        Limits the files that browsers upload.
    viser
        The `viser.ViserServer`, with the scene and the widgets.

    """

    def __init__(self, title: str, settings: PageSettings | None = None) -> None:
        from rviz_common.page.gate import gated

        settings = settings or PageSettings()
        if not settings.token:
            settings = replace(settings, token=secrets.token_urlsafe(16))
        rich.get_console().quiet = True  # viser prints addresses, but not the token
        bound = listen(settings)
        self.settings = settings
        self.port: int = bound.getsockname()[1]
        self.routes = Routes()
        self.uploads = Uploads()
        self._token = '' if settings.token == NO_TOKEN else settings.token
        admission = Admission(self.port, self._token)
        with gated(bound, title, admission, self.routes, self.uploads, self._options_of):
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
        # Shadows halve the frame rate with software rendering.
        self.viser.scene.configure_default_lights(cast_shadow=False)

    @property
    def urls(self) -> list[str]:
        """The URLs to open, with the token if there is one; the best one first."""
        query = f'?{urlencode({"token": self._token})}' if self._token else ''
        hosts = [f'[{each}]' if ':' in each else each for each in reachable(self.settings.host)]
        return [f'http://{host}:{self.port}/{query}' for host in hosts]

    @property
    def url(self) -> str:
        """The URL to open."""
        return self.urls[0]

    def end_upload(self, start: FileTransferStartUpload) -> None:
        """
        Make browsers stop showing the progress of an upload that was rejected.

        They would show it as uploaded instead, so that their notification is removed too.

        Parameters
        ----------
        start
            The announcement of the file by the browser.

        """
        complete = FileTransferPartAck(
            start.source_component_uuid,
            start.transfer_uuid,
            transferred_bytes=start.size_bytes,
            total_bytes=start.size_bytes,
        )
        for client in self.viser.get_clients().values():
            for message in (complete, RemoveNotificationMessage(f'upload-{start.transfer_uuid}')):
                client.gui._websock_interface.queue_message(message)

    def _options_of(self, widget: str) -> tuple[str, ...] | None:
        """Return the options of a choice widget, None if there is no such widget."""
        handle = self.viser.gui._gui_input_handle_from_uuid.get(widget)
        options: tuple[str, ...] | None = getattr(handle, 'options', None)
        return options

    def close(self) -> None:
        """Stop serving the page."""
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
