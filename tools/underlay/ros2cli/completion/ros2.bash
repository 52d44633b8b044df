# SPDX-License-Identifier: Apache-2.0
# Completes `ros2` in bash. Nothing runs before TAB is pressed, nor where nobody can press it.

case $- in
  *i*)
    _ros2_complete() {
      # argcomplete's protocol: the line goes in by variables, the words come out on descriptor 8.
      local words
      words=$(
        _ARGCOMPLETE=1 _ARGCOMPLETE_SHELL=bash _ARGCOMPLETE_IFS=$'\n' \
        _ARGCOMPLETE_SUPPRESS_SPACE=0 _ARGCOMPLETE_COMP_WORDBREAKS=$COMP_WORDBREAKS \
        COMP_LINE=$COMP_LINE COMP_POINT=$COMP_POINT COMP_TYPE=$COMP_TYPE \
        "$1" 8>&1 9>/dev/null >/dev/null 2>&1 </dev/null || :
      )
      COMPREPLY=()
      [ -z "$words" ] || mapfile -t COMPREPLY <<< "$words"
    }
    complete -o nospace -F _ros2_complete ros2
    ;;
esac
