# SPDX-License-Identifier: Apache-2.0
"""The smoother server and its smoothers."""
