# SPDX-License-Identifier: Apache-2.0
"""What `ros2 pkg create` writes."""
