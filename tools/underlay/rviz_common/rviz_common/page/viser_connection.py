# SPDX-License-Identifier: Apache-2.0
"""The connection of viser to browsers, for what its scene and its widgets have no method for."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from viser import GuiApi
    from viser.infra import WebsockMessageHandler

__all__ = ['connection_of']


def connection_of(gui: GuiApi) -> WebsockMessageHandler:
    """
    Return what sends the messages of viser: a public class, to which no public attribute leads.

    Parameters
    ----------
    gui
        The widgets of all browsers, or of one.

    Returns
    -------
    viser.infra.WebsockMessageHandler
        The connection to all browsers, or to that one.

    """
    return gui._websock_interface
