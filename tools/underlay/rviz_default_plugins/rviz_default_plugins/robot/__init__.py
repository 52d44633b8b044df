# SPDX-License-Identifier: Apache-2.0
"""Drawing of the robot described by a URDF."""
