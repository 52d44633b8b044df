# SPDX-License-Identifier: Apache-2.0
"""RViz plugins of Nav2: particle cloud display, goal tool, and navigation panel."""
