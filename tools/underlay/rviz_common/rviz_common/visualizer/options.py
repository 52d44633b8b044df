# SPDX-License-Identifier: Apache-2.0
"""The global options."""

from rviz_common.properties import ColorOf, Number, Text

__all__ = ['BACKGROUND', 'FIXED_FRAME', 'FRAME_RATE', 'OPTIONS', 'UNUSED_OPTIONS']

BACKGROUND, FIXED_FRAME, FRAME_RATE = 'Background Color', 'Fixed Frame', 'Frame Rate'
OPTIONS = (
    ColorOf(BACKGROUND, (48, 48, 48), 'The color behind all.'),
    Text(FIXED_FRAME, 'map', 'The frame that does not move on the screen.'),
    Number(FRAME_RATE, 30.0, 'How many times a second all is drawn at most; beyond 60 is 60.', 1),
)
UNUSED_OPTIONS = ('Default Light',)
