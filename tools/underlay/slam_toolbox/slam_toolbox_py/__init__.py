# SPDX-License-Identifier: Apache-2.0
"""Simultaneous localization and mapping with a planar laser scanner."""
