# Plain English in pages and comments: phrases that hide the subject, long sentences and long paragraphs are counted.
# A count above its level fails: rewrite the sentence, or lower the level once others were rewritten.
cd "$TOP" || exit
python3 - <<'EOF'
import glob, re, sys

# pattern or rule: the greatest count
LEVELS = {
    r'\b(that|those|these) of\b': 20,
    r'\bwhat (is|it|they)\b': 30,
    r'\bbehind\b': 5,
    r'\b(told|tells?)\b': 9,
    r'\b(is|are) had\b': 0,
    'sentence begins with Of, What, Where or That which': 30,
    'sentence of a comment over 30 words': 95,
    'sentence of a page over 30 words': 22,
    'paragraph of a page over six lines': 9,
}
BEGINS = re.compile(r'(?:^|[.:;!?]\s+)(?:Of|What|Where|That which)\b')
SKIPPED = ('.Dd', '.Dt', '.Os', '.\\"', '|', '![', '#')
found = {rule: [] for rule in LEVELS}


def look(place, text, kind):
    text = ' '.join(text.split())
    for rule in LEVELS:
        if rule.startswith('\\b'):
            found[rule] += [(place, m.group()) for m in re.finditer(rule, text, re.I)]
    found['sentence begins with Of, What, Where or That which'] += [(place, m.group()) for m in BEGINS.finditer(text)]
    for sentence in re.split(r'(?<=[.;!?])\s+', text):
        if len(sentence.split()) > 30:
            found['sentence of a %s over 30 words' % kind].append((place, sentence))
    if kind == 'page' and len(text) > 6 * 78:
        found['paragraph of a page over six lines'].append((place, text[:70]))


def comments(name):
    text = open(name).read()
    for m in re.finditer(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|/\*.*?\*/', text, re.S):
        if m.group().startswith('/*'):
            # an empty or an indented line ends a paragraph
            body = re.sub(r'\n[ \t]*\*?[ \t]*(?=\n)', '\n\n', m.group()[2:-2])
            for part in re.split(r'\n\n+|\n \*(?=[ \t]{2})', re.sub(r'\n[ \t]*\* ?(?![ \t])', '\n', body)):
                look('%s:%d' % (name, text.count('\n', 0, m.start()) + 1), part, 'comment')


def page(name):
    """Paragraphs of an mdoc page or of Markdown, without examples, tables and references."""
    part, skip, section = [], False, ''

    def flush():
        if part:
            look(name, ' '.join(part), 'page')
        part.clear()
    for line in open(name):
        line = line.rstrip('\n')
        if re.match(r'```|\.Bd|\.Ed|\.Rs|\.Re', line):
            flush()
            skip = line[:3] in ('.Bd', '.Rs') or (line[:3] == '```' and not skip)
        elif line.startswith('.Sh'):
            flush()
            section = line[4:]
        elif skip or section in ('SYNOPSIS', 'SEE ALSO') or line.startswith(SKIPPED):
            flush()
        elif not line or re.match(r'\.(Ss|Pp|It|Bl|El)\b', line):
            flush()
            if line.startswith('.It') and ' Ta ' in line:
                continue
            if line.startswith('.It'):
                part += [word for word in line.split()[1:] if not re.match(r'[A-Z][a-z]$', word)]
        elif line.startswith('- '):
            flush()
            part.append(line[2:])
        else:
            text = re.sub(r'^\.', '', line)
            words = [word for word in text.split() if not (line[0] == '.' and re.match(r'[A-Z][a-z]$', word))]
            part += words
    flush()


for name in sorted(glob.glob('cmd/*.[ch]') + glob.glob('formats/**/*.[ch]', recursive=True) +
                   glob.glob('lib/**/*.[ch]', recursive=True)):
    comments(name)
for name in ['README.md'] + sorted(glob.glob('man/*')):
    page(name)
bad = False
for rule, level in LEVELS.items():
    print('%s: %d, at most %d' % (rule, len(found[rule]), level))
    if len(found[rule]) > level:
        print(*('  %s: %s' % place for place in found[rule]), sep='\n')
        bad = True
sys.exit(bad)
EOF
