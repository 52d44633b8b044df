# SPDX-License-Identifier: Apache-2.0
"""Conversion of node parameters to and from text, and access to them."""
