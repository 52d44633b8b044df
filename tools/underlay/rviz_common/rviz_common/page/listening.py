# SPDX-License-Identifier: Apache-2.0
"""Take a port of this machine."""

from __future__ import annotations

import errno
import os
import socket

from rviz_common.page.settings import FIRST_PORT, PageSettings

__all__ = ['PortError', 'listen']

TRIES = 100


class PortError(RuntimeError):
    """A port that cannot be taken, with the reason."""


def listen(settings: PageSettings) -> socket.socket:
    """Return a socket that is bound to the port of the settings or, without one, to a free one."""
    if settings.port is not None:
        return _bind(settings.host, settings.port)
    for port in range(FIRST_PORT, FIRST_PORT + TRIES):
        try:
            return _bind(settings.host, port)
        except PortError as error:
            failure = error
    raise failure


def _bind(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ':' in host else socket.AF_INET
    bound = socket.socket(family, socket.SOCK_STREAM)
    bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        bound.bind((host, port))
    except OSError as error:
        bound.close()
        raise PortError(_reason(host, port, error.errno or 0)) from error
    return bound


def _reason(host: str, port: int, number: int) -> str:
    """Say why a port cannot be taken, and what to do."""
    why = os.strerror(number)
    if number not in (errno.EADDRINUSE, errno.EACCES):
        return (
            f'{host} cannot be used: {why}. The host must be an address of this machine, such as '
            '127.0.0.1, or 0.0.0.0 for all of them.'
        )
    return (
        f'Port {port} of {host} cannot be taken: {why}. End what uses it, or choose another port; '
        'without a choice the next free one is taken.'
    )
