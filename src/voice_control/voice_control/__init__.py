# SPDX-License-Identifier: Apache-2.0
"""From a microphone to words, and from words to a loudspeaker."""
