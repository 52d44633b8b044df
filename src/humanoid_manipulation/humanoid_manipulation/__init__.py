# SPDX-License-Identifier: Apache-2.0
"""Manipulation: reach for objects, pick them up and place them."""
