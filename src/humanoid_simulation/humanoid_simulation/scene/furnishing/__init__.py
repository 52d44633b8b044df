# SPDX-License-Identifier: Apache-2.0
"""
The shapes of furniture, lamps and human figures.

Every function accepts a size (length, width, height) and a colour (red, green, blue), and returns
the parts. The origin is on the ground below the centre of the piece; x points to its front, so the
length of a cupboard is its depth.
"""
