# SPDX-License-Identifier: Apache-2.0
"""Base classes for the displays, tools and panels of RViz in the browser."""
