"""Finds every place of a C++ source where a mutant can be made, and writes the source with all of them
in it, each switched on at run time by its number (mutant.h).

The text is split into tokens; no compiler is asked. That suffices because clang-format has been over
it: a binary operator has a space on either side, a template's bracket or a reference has not.

Mutants, for the text of a function's body (not: preprocessor, static_assert, assert, constexpr
variables, consteval functions, case labels):
  a < b       a <= b and a > b; likewise for > <= >=
  a == b      a != b, and the reverse
  a + b       a - b, and the reverse (not for texts; b - a between iterators); ++a and --a,
              a += b and a -= b likewise
  -a  !a      a
  a |= b      nothing; likewise for &= and ^=
  a && b      each operand left out; likewise for ||
  std::min    std::max, and the reverse
  if (a)      never; and the reverse of a condition that has no operator of its own, also in a ? b : c
  for         the last round left out
  return true return false, and the reverse
  case        skipped; in a switch over sides, a split taken for one side, and sides exchanged
  continue    left out
"""
import re
from dataclasses import dataclass

TOKEN = re.compile(r"""
    (?P<space>\s+|//[^\n]*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#(?:[^\n\\]|\\.|\\\n)*)
  | (?P<text>R"\((?:.|\n)*?\)"|"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')
  | (?P<number>(?:0x[0-9a-fA-F'.]+(?:p[+-]?\d+)?|\d[\d'.]*(?:e[+-]?\d+)?)[uUlLfF]*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<sign><=>|<<=|>>=|->\*|\.\.\.|::|->|\+\+|--|<<|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|.)
""", re.VERBOSE | re.DOTALL | re.MULTILINE)

COMPARISONS = {"<": ("Less", "<=", ">"), ">": ("Greater", ">=", "<"),
               "<=": ("LessEqual", "<", ">="), ">=": ("GreaterEqual", ">", "<=")}
PAIRS = {"==": ("Equal", "!="), "!=": ("Unequal", "=="), "+": ("Plus", "-"), "-": ("Minus", "+")}
UPDATES = {"+=": "PlusUpdate", "-=": "MinusUpdate", "|=": "OrUpdate", "&=": "AndUpdate",
           "^=": "XorUpdate"}
PREFIXES = {"-": ("Negative", ""), "!": ("Not", ""), "++": ("Increment", "--"),
            "--": ("Decrement", "++")}
LAST = {"<": "<[last round left out]", ">": ">[last round left out]",
        "<=": "<", ">=": ">", "!=": "!=[last round left out]"}
LAST_NAMES = {"<": "Less", ">": "Greater", "<=": "LessEqual", ">=": "GreaterEqual", "!=": "Unequal"}
OPEN, CLOSE = {"(": ")", "[": "]", "{": "}"}, {")", "]", "}"}
# What ends an operand of && and ||, or a condition before `?`, at its own depth of brackets.
BORDERS = {",", ";", "?", ":", "=", "+=", "-=", "|=", "&=", "^=", "return", "{", "}", "(", "["}


@dataclass
class Token:
    kind: str
    text: str
    start: int
    spaced_before: bool = False
    spaced_after: bool = False
    partner: int = -1  # index of the other bracket
    parent: int = -1   # index of the enclosing opening bracket


@dataclass
class Mutant:
    file: str
    line: int
    text: str  # the line as the mutant has it
    number: int = -1

    @property
    def key(self):
        return f"{self.file}: {self.text}"


def tokens_of(source):
    tokens, spaced, at = [], True, 0
    while at < len(source):
        match = TOKEN.match(source, at)
        at = match.end()
        if match.lastgroup == "space":
            spaced = True
            if tokens:
                tokens[-1].spaced_after = True
            continue
        tokens.append(Token(match.lastgroup, match.group(), match.start(), spaced))
        spaced = False
    stack = []
    for i, token in enumerate(tokens):
        if token.kind == "sign" and token.text in CLOSE:
            opening = stack.pop()
            assert OPEN[tokens[opening].text] == token.text, f"brackets at {token.start}"
            token.partner, tokens[opening].partner = opening, i
        token.parent = stack[-1] if stack else -1
        if token.kind == "sign" and token.text in OPEN:
            stack.append(i)
    assert not stack, "a bracket is not closed"
    return tokens


class Instrumenter:
    """One source file. `number` is the first mutant's."""

    def __init__(self, name, source, number):
        self.name, self.source, self.next = name, source, number
        self.tokens = tokens_of(source)
        self.edits = []    # (position, length, order among those at one position, replacement)
        self.mutants = []
        self.done = set()  # operands of && and || that were wrapped, by first token
        self.frozen = self.frozen_tokens()

    # --- where nothing may be changed ---

    def frozen_tokens(self):
        frozen = set()
        depth_of_body = self.function_bodies()
        for i, t in enumerate(self.tokens):
            if i not in depth_of_body:
                frozen.add(i)
            if t.kind != "word":
                continue
            if t.text in ("static_assert", "assert", "requires", "sizeof", "decltype", "alignas"):
                frozen.update(range(i, self.tokens[i + 1].partner + 1))
            elif t.text == "case" or t.text == "using":
                end = ":" if t.text == "case" else ";"
                while self.tokens[i].text != end:
                    frozen.add(i)
                    i += 1
            elif t.text == "constexpr":
                if self.tokens[i - 1].text == "if":
                    frozen.update(range(i, self.tokens[i + 1].partner + 1))
                elif i in depth_of_body or self.is_constant(i):
                    while self.tokens[i].text != ";":
                        last = max(i, self.tokens[i].partner)
                        frozen.update(range(i, last + 1))
                        i = last + 1
            elif t.text == "consteval":
                while self.tokens[i].text != "{":
                    i += 1
                frozen.update(range(i, self.tokens[i].partner + 1))
        return frozen

    def is_constant(self, i):
        """Whether what `constexpr` says of is a variable, not a function."""
        while self.tokens[i].text not in ("=", "(", "{", ";"):
            i += 1
        return self.tokens[i].text == "="

    def function_bodies(self):
        """Tokens inside `{}` that is the body of a function, or in a constructor's initialisers."""
        inside = set()
        i = 0
        while i < len(self.tokens):
            if self.tokens[i].text == "{" and self.tokens[i].kind == "sign" and self.is_body(i):
                inside.update(range(i, self.tokens[i].partner + 1))
                i = self.tokens[i].partner
            i += 1
        return inside

    def is_body(self, brace):
        i = brace - 1
        while i >= 0 and self.tokens[i].text in ("const", "override", "noexcept", "final"):
            i -= 1
        # `) {`, a constructor's `: a_(b), c_{d} {`, and `) -> Type {`.
        while i >= 0 and self.tokens[i].text not in (";", "}", "{"):
            if self.tokens[i].text == ")":
                return True
            i = self.tokens[i].partner - 1 if self.tokens[i].text == "]" else i - 1
        return False

    # --- making mutants ---

    def line_of(self, position):
        return self.source.count("\n", 0, position) + 1

    def add_mutant(self, start, length, replacement):
        """A mutant that reads as if source[start:start + length] were `replacement`."""
        begin = self.source.rfind("\n", 0, start) + 1
        end = self.source.find("\n", start)
        rest = self.source[start + length:end] if start + length <= end else ""
        text = (self.source[begin:start] + replacement + rest).split("//")[0]
        mutant = Mutant(self.name, self.line_of(start), " ".join(text.split()), self.next)
        self.mutants.append(mutant)
        self.next += 1
        return mutant.number

    def replace(self, token, replacement):
        self.edits.append((token.start, len(token.text), (2, 0), replacement))

    def wrap(self, first, last, before, after):
        """Puts text around the tokens first..last."""
        start = self.tokens[first].start
        end = self.tokens[last].start + len(self.tokens[last].text)
        self.edits.append((start, 0, (1, -end), before))
        self.edits.append((end, 0, (0, -start), after))

    def run(self):
        for i, token in enumerate(self.tokens):
            if i in self.frozen or token.kind in ("directive", "text", "number"):
                continue
            if token.kind == "word":
                self.word(i, token)
            else:
                self.sign(i, token)
        parts, at = ['#include "mutant.h"\n'], 0
        for start, length, _, replacement in sorted(self.edits, key=lambda e: (e[0], e[2])):
            assert start >= at, f"edits overlap at line {self.line_of(start)}"
            parts += [self.source[at:start], replacement]
            at = start + length
        return "".join(parts) + self.source[at:]

    def sign(self, i, token):
        text = token.text
        before = self.tokens[i - 1]
        if before.text == "operator":
            return
        binary = token.spaced_before and token.spaced_after
        if binary and text in LAST_NAMES and self.ends_loop(i):
            n = self.add_mutant(token.start, len(text), LAST[text])
            self.replace(token, f"{text}csgrun_mutant::Last{LAST_NAMES[text]}<{n}>{{}}{text}")
        elif binary and text in COMPARISONS:
            name, border, turned = COMPARISONS[text]
            n = self.add_mutant(token.start, len(text), border)
            self.add_mutant(token.start, len(text), turned)
            self.replace(token, f"{text}csgrun_mutant::{name}<{n}>{{}}{text}")
        elif binary and text in PAIRS and "text" not in (before.kind, self.tokens[i + 1].kind):
            name, other = PAIRS[text]
            n = self.add_mutant(token.start, len(text), other)
            self.replace(token, f"{text} csgrun_mutant::{name}<{n}>{{}} {text}")
        elif binary and text in UPDATES:
            n = self.add_mutant(token.start, len(text),
                                {"+=": "-=", "-=": "+="}.get(text, f"{text}[left out]"))
            self.replace(token, f"{text} csgrun_mutant::{UPDATES[text]}<{n}>{{}} {text}")
        elif binary and text in ("&&", "||"):
            self.logical(i)
        elif text in PREFIXES and not token.spaced_after and self.starts_operand(i):
            if text in ("++", "--") and self.in_for_header(i):
                return  # every such mutant runs for ever
            name, other = PREFIXES[text]
            n = self.add_mutant(token.start, len(text), other)
            self.replace(token, f"csgrun_mutant::{name}<{n}>{{}} ->* ")
        elif binary and text == "?":
            self.ternary(i)

    def word(self, i, token):
        tokens = self.tokens
        following = tokens[i + 1]
        if token.text == "if" and following.text == "(":
            self.condition(i + 1)
        elif token.text == "switch":
            self.switch(i + 1)
        elif (token.text in ("min", "max") and following.text == "(" and
              tokens[i - 1].text == "::" and tokens[i - 2].text == "std"):  # not of numeric_limits
            other = "max" if token.text == "min" else "min"
            n = self.add_mutant(token.start, 3, other)
            smallest = "true" if token.text == "min" else "false"
            std = tokens[i - 2]
            self.edits.append((std.start, token.start + 3 - std.start, (2, 0),
                               f"csgrun_mutant::Extreme<{n}, {smallest}>{{}}"))
        elif token.text == "return" and following.text in ("true", "false"):
            other = "false" if following.text == "true" else "true"
            n = self.add_mutant(following.start, len(following.text), other)
            self.replace(following, f"({following.text} != csgrun_mutant::active<{n}>())")
        elif token.text == "continue":
            n = self.add_mutant(token.start, 8, "")
            self.replace(token, f"if (!csgrun_mutant::active<{n}>()) continue")

    # --- conditions ---

    def starts_operand(self, i):
        before = self.tokens[i - 1]
        if before.kind in ("number", "text"):
            return False
        if before.kind == "word":
            return before.text in ("return", "else", "do")
        return before.text not in (")", "]", "}") or self.starts_statement(i)

    def starts_statement(self, i):
        before = self.tokens[i - 1]
        if before.text in (";", "{", "}"):
            return True
        opening = before.partner
        return before.text == ")" and self.tokens[opening - 1].text in ("if", "for", "while")

    def for_header(self, i):
        """The opening bracket of the `for (a; b; c)` that token i stands in, itself, or None."""
        while i >= 0 and self.tokens[i].text != "{":
            parent = self.tokens[i].parent
            if parent >= 0 and self.tokens[parent].text == "(" and self.tokens[parent - 1].text == "for":
                return parent
            i = parent
        return None

    def in_for_header(self, i):
        return self.for_header(i) is not None

    def ends_loop(self, i):
        """Whether token i stands in the condition of a `for` as a comparison of its own."""
        parent = self.tokens[i].parent
        if parent < 0 or self.tokens[parent].text != "(" or self.tokens[parent - 1].text != "for":
            return False
        semicolons = [k for k in range(parent, i)
                      if self.tokens[k].text == ";" and self.tokens[k].parent == parent]
        if len(semicolons) != 1 or "?" in (t.text for t in self.tokens[semicolons[0]:i]):
            return False
        # The loop's variable is what the header sets; `&& found == 0` is not a bound.
        counted = [t.text for k, t in enumerate(self.tokens[parent:semicolons[0]], parent)
                   if t.kind == "word" and self.tokens[k + 1].text == "="]
        step = [t.text for t in self.tokens[semicolons[0]:self.tokens[parent].partner]]
        left = self.tokens[i - 1].text
        if left == "--":
            left = self.tokens[i - 2].text
        return left in counted or left in step[step.index(";", 1):]

    def logical(self, i):
        identity = "true" if self.tokens[i].text == "&&" else "false"
        for step in (-1, 1):
            near, far = i + step, self.operand_end(i, step)
            first, last = min(near, far), max(near, far)
            if (first, last) in self.done:
                continue
            self.done.add((first, last))
            start = self.tokens[first].start
            length = self.tokens[last].start + len(self.tokens[last].text) - start
            n = self.add_mutant(start, length, identity)
            self.wrap(first, last, f"csgrun_mutant::fixed<{n}, {identity}>(static_cast<bool>(", "))")

    def operand_end(self, i, step):
        """Index of the far token of the operand beside the && or || at i."""
        borders = BORDERS | {"||"} | ({"&&"} if self.tokens[i].text == "&&" else set())
        at = i + step
        while True:
            # Over a bracket as a whole.
            jump = self.tokens[at].partner
            if jump >= 0 and (jump - at) * step > 0:
                at = jump
            beyond = self.tokens[at + step]
            opens, closes = beyond.text in OPEN, beyond.text in CLOSE
            if step > 0 and (closes or (not opens and beyond.text in borders)):
                return at
            if step < 0 and (opens or (not closes and beyond.text in borders)):
                return at
            at += step

    def has_operator(self, first, last):
        """Whether tokens first..last, outside inner brackets, have a mutant of their own."""
        parent = self.tokens[first].parent
        for k in range(first, last + 1):
            t = self.tokens[k]
            if t.parent != parent:
                continue
            if t.text in ("&&", "||", "==", "!=", "<", ">", "<=", ">=") and t.spaced_before and t.spaced_after:
                return True
            if t.text == "!" and k == first:
                return True
        return False

    def condition(self, opening):
        """`if (...)`: never, and its reverse if nothing in it is an operator."""
        closing = self.tokens[opening].partner
        first, last = opening + 1, closing - 1
        for k in range(first, closing):  # after `if (int a = f();`
            if self.tokens[k].text == ";" and self.tokens[k].parent == opening:
                first = k + 1
        inner = range(first, closing)
        declared = [k for k in inner if self.tokens[k].text == "=" and self.tokens[k].parent == opening]
        start = self.tokens[first].start
        length = self.tokens[closing].start - start
        n = self.add_mutant(start, length, f"false && ({self.source[start:start + length]})")
        if declared:
            self.wrap(declared[0] + 1, last, f"csgrun_mutant::or_zero<{n}>(", ")")
            return
        if self.has_operator(first, last):
            self.wrap(first, last, f"csgrun_mutant::fixed<{n}, false>(static_cast<bool>(", "))")
            return
        turned = self.add_mutant(start, length, f"!({self.source[start:start + length]})")
        self.wrap(first, last, f"csgrun_mutant::fixed<{n}, false>(csgrun_mutant::turned<{turned}>("
                               "static_cast<bool>(", ")))")

    def ternary(self, i):
        far = self.operand_end(i, -1)
        if self.has_operator(far, i - 1):
            return
        start = self.tokens[far].start
        end = self.tokens[i - 1].start + len(self.tokens[i - 1].text)
        n = self.add_mutant(start, end - start, f"!({self.source[start:end]})")
        self.wrap(far, i - 1, f"csgrun_mutant::turned<{n}>(static_cast<bool>(", "))")

    def switch(self, opening):
        closing = self.tokens[opening].partner
        body = closing + 1
        labels = [k for k in range(body, self.tokens[body].partner)
                  if self.tokens[k].text in ("case", "default") and self.tokens[k].parent == body]
        if self.tokens[labels[0] + 1].text == "Side":
            start = self.tokens[opening].start
            length = self.tokens[closing].start + 1 - start
            whole = " ".join(self.source[start:start + length].split())
            n = self.add_mutant(start, length, f"{whole}[split taken for front]")
            self.add_mutant(start, length, f"{whole}[split taken for back]")
            self.add_mutant(start, length, f"{whole}[front and back exchanged]")
            self.wrap(opening + 1, closing - 1, f"csgrun_mutant::side<{n}>(", ")")
        for label in labels:
            colon = label
            while self.tokens[colon].text != ":":
                colon += 1
            if self.tokens[colon + 1].text in ("return", "break", "case", "default"):
                continue
            t = self.tokens[colon]
            n = self.add_mutant(t.start, 1, ": break;")
            self.replace(t, f": if (csgrun_mutant::active<{n}>()) break;")


def count_mutants(name, source):
    file = Instrumenter(name, source, 0)
    file.run()
    return len(file.mutants)


def number_keys(mutants):
    """Tells equal keys of one file apart by their order."""
    count = {}
    for m in mutants:
        count[m.key] = count.get(m.key, 0) + 1
        if count[m.key] > 1:
            m.text += f"  #{count[m.key]}"
