# SPDX-License-Identifier: Apache-2.0
"""Messages to browsers for which viser has no method."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from viser import GuiApi
    from viser.infra import Message

__all__ = ['send']


def send(gui: GuiApi, message: Message) -> None:
    """
    Send a message of viser to browsers.

    Parameters
    ----------
    gui
        The widgets of all browsers, or of the one that is to receive it.
    message
        The message.

    """
    gui._websock_interface.queue_message(message)
