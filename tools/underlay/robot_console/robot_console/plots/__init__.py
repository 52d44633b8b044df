# SPDX-License-Identifier: Apache-2.0
"""Plots of numeric message fields: series, values, drawing and widgets."""
