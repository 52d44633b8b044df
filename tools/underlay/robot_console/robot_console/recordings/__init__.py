# SPDX-License-Identifier: Apache-2.0
"""Recording, playback and export for the recordings panel."""
