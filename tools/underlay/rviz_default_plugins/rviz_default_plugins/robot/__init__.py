# SPDX-License-Identifier: Apache-2.0
"""Draw the robot that a URDF describes."""
