# SPDX-License-Identifier: Apache-2.0
"""The named colours, which are far enough apart to be distinguished in an image."""

from __future__ import annotations

from humanoid_simulation.scene.parts import Vector

COLOURS: dict[str, Vector] = {
    'red': (0.82, 0.1, 0.1),
    'blue': (0.1, 0.22, 0.82),
    'green': (0.1, 0.6, 0.16),
    'yellow': (0.95, 0.82, 0.1),
    'orange': (0.95, 0.45, 0.05),
    'purple': (0.45, 0.15, 0.6),
    'pink': (0.95, 0.45, 0.65),
    'brown': (0.45, 0.28, 0.14),
    'white': (0.94, 0.94, 0.92),
    'grey': (0.5, 0.5, 0.52),
    'black': (0.08, 0.08, 0.09),
}
