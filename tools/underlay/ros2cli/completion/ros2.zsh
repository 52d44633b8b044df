# SPDX-License-Identifier: Apache-2.0
# Completes `ros2` in zsh. Nothing runs before TAB is pressed, nor where nobody can press it.

if [[ -o interactive ]]; then
  _ros2_complete() {
    local begin= line
    if [[ -z $QIPREFIX && $PREFIX == [~\$][[:alnum:]_]#/* ]]; then
      # A path that begins with ~ or a variable: what the shell makes of it is looked up.
      begin=${(e)~PREFIX%%/*}/
      compset -P 1 '*/'
    fi
    # argcomplete's protocol: the line goes in by variables, the words come out on descriptor 8.
    line="${(j: :)words[1,CURRENT-1]} $QIPREFIX${begin:+${(q)begin}}$PREFIX"
    local -a found open quoted
    found=("${(@f)$(
      _ARGCOMPLETE=1 _ARGCOMPLETE_SHELL=zsh _ARGCOMPLETE_IFS=$'\n' \
      _ARGCOMPLETE_SUPPRESS_SPACE=1 COMP_LINE=$line COMP_POINT=${#line} \
      ${~words[1]} 8>&1 9>/dev/null >/dev/null 2>&1 </dev/null || :
    )}")
    found=("${(@)found%:(None|)}")  # where there is no description
    found=("${(@)found#$begin}")
    quoted=("${(@)${(@M)found:#\"*}//\\:/:}")  # a whole message
    open=(${(M)found:#*[=/]})
    found=(${found:#(\"*|*[=/])})
    [[ ${words[CURRENT]} == \{* ]] || compadd -Q -- $quoted
    (( $#open )) && _describe ros2 open -S ''
    (( $#found )) && _describe ros2 found
  }
  (( $+functions[compdef] )) || { autoload -Uz compinit && compinit -C -D }
  compdef _ros2_complete ros2
fi
