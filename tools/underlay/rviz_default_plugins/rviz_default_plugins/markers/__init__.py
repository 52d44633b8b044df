# SPDX-License-Identifier: Apache-2.0
"""Draw the markers of `visualization_msgs`."""
