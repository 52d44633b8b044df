# SPDX-License-Identifier: Apache-2.0
"""Record, play and export: what the panel of recordings is made of."""
