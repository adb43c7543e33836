# Completion of strait's command line for bash, which loads it by the name of the program.
_strait()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local options="--set --output --resume --force --dry-run --parameters --columns --scenes
    --quiet --version --help"
  COMPREPLY=()
  case $before in
    --set)
      # Names of parameters contain blanks: one a line, in the quotes that the shell needs.
      local IFS=$'\n'
      local names
      names=$("${COMP_WORDS[0]}" --parameters prm 2>/dev/null | awk '
        { sub(/^ +/, "") }
        /^subsection / { path = path substr($0, 12) "/" }
        /^end$/ { sub(/[^\/]*\/$/, "", path) }
        /^set / { sub(/^set /, ""); sub(/ *=.*/, ""); print path $0 }')
      word=${word#[\"\']}
      local name
      for name in $names; do
        [[ $name == "$word"* ]] && COMPREPLY+=("\"$name=")
      done
      compopt -o nospace 2>/dev/null
      return
      ;;
    --output)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$word")
      return
      ;;
    --parameters)
      mapfile -t COMPREPLY < <(compgen -W "prm md" -- "$word")
      return
      ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -X '!*.prm' -- "$word"; compgen -d -- "$word")
  fi
}
complete -F _strait strait
