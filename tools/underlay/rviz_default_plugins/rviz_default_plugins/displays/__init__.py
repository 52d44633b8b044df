# SPDX-License-Identifier: Apache-2.0
"""Displays: what RViz draws."""
