# SPDX-License-Identifier: Apache-2.0
"""What is behind all."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from viser import ViserServer

__all__ = ['paint']


def paint(server: ViserServer, color: tuple[int, int, int]) -> None:
    """Give the scene a background of one color."""
    import numpy as np

    server.scene.set_background_image(np.full((1, 1, 3), color, np.uint8), format='png')
