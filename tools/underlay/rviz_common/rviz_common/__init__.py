# SPDX-License-Identifier: Apache-2.0
"""What the displays, tools and panels of RViz in the browser are made of."""
