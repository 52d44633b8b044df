# SPDX-License-Identifier: Apache-2.0
"""Utilities for the launch files of navigation."""
