# SPDX-License-Identifier: Apache-2.0
"""Reach for things, take them and put them down."""
