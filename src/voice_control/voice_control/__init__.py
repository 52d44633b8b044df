# SPDX-License-Identifier: Apache-2.0
"""Speech recognition from a microphone, and speech output to a loudspeaker."""
