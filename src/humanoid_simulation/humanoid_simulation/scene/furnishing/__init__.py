# SPDX-License-Identifier: Apache-2.0
"""
The shapes of furniture, lamps and figures of people.

Every function takes length, width and height, and the colour (red, green, blue), and returns the
parts. Axes begin on the ground below the middle; x is where the piece faces, so that its length
is the depth of a cupboard.
"""
