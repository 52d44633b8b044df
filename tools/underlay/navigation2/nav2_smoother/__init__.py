# SPDX-License-Identifier: Apache-2.0
"""The server that smooths paths, and its smoothers."""
