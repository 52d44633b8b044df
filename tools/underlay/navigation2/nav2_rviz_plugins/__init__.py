# SPDX-License-Identifier: Apache-2.0
"""What users of Nav2 have in RViz: particles, the goal tool, and the panel of navigation."""
