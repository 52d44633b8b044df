# SPDX-License-Identifier: Apache-2.0
"""Dry run: visit a launch description without starting anything, and show the result."""
