# SPDX-License-Identifier: Apache-2.0
"""Gestures: their file, their plan for a robot, and the goals that carry them out."""
