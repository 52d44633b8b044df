# SPDX-License-Identifier: Apache-2.0
"""The topics on which the simulator tells what no robot could know, and what the time is."""
