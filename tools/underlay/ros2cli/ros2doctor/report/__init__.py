# SPDX-License-Identifier: Apache-2.0
"""The sections of `ros2 doctor --report`, one per module."""
