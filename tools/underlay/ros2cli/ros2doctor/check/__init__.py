# SPDX-License-Identifier: Apache-2.0
"""Checks of the facts, one per module."""
