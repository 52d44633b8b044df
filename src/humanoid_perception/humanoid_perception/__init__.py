# SPDX-License-Identifier: Apache-2.0
"""Perception of the humanoid: object detection, 3-D localisation, object memory and gaze."""
