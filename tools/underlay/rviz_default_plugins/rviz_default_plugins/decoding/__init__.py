# SPDX-License-Identifier: Apache-2.0
"""Decoding of messages to arrays, independent of the page."""
