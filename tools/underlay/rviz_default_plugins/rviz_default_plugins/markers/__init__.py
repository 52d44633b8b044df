# SPDX-License-Identifier: Apache-2.0
"""Drawing of the markers of `visualization_msgs`."""
