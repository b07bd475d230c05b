//! Tokens to a tree, by operator precedence.
//!
//! The stack is a vector, not the program's: no formula can overflow it. A mistake is noted and the nearest
//! correct formula is parsed on, so that one run finds all independent mistakes.

use super::complaints::{chained, mismatch, too_deep, unclosed, unopened};
use super::error::{Code, FormulaError, Span};
use super::lexer::{Bracket, Token, TokenKind};
use super::syntax::{BinaryOperator, NodeId, SIGN_BINDING, Standing, Syntax, SyntaxNode, Tree};

/// Brackets may be nested this deep.
pub(super) const MAX_DEPTH: usize = 100;

pub(super) fn parse(text: &str, tokens: Vec<Token>) -> Result<Tree, Vec<FormulaError>> {
    let mut parser = Parser { text, ..Parser::default() };
    for token in tokens {
        parser.token(token);
        if parser.too_deep {
            return Err(parser.errors);
        }
    }
    parser.finish()
}

/// What waits on the stack for its right-hand side.
enum Pending {
    Infix(BinaryOperator),
    Sign { minus: bool, at: usize },
    Open(Opening),
}

struct Opening {
    bracket: Bracket,
    span: Span,
    /// The name of the function that is called.
    function: Option<Span>,
    /// How many operands there were before.
    base: usize,
}

impl Opening {
    /// Whether commas separate what stands inside.
    fn is_list(&self) -> bool {
        self.function.is_some() || self.bracket == Bracket::Square
    }
}

#[derive(Default)]
struct Parser<'t> {
    text: &'t str,
    nodes: Vec<SyntaxNode>,
    operands: Vec<NodeId>,
    pending: Vec<Pending>,
    depth: usize,
    too_deep: bool,
    /// Whether the last token was a value or a closing bracket.
    have_value: bool,
    /// The last token.
    last: Span,
    errors: Vec<FormulaError>,
}

impl Parser<'_> {
    fn token(&mut self, Token { kind, span }: Token) {
        self.last_step(&kind, &span);
        let end = span.clone();
        match kind {
            TokenKind::Quantity(value, chain) => {
                self.value(Syntax::Quantity { value, chain, standing: Standing::Within }, span);
            }
            TokenKind::Broken => self.value(Syntax::Broken, span),
            TokenKind::Name => self.value(Syntax::Name(span.clone()), span),
            TokenKind::BinaryOperator(operator) => self.operator(operator, span),
            TokenKind::Open(bracket) => self.open(bracket, span),
            TokenKind::Close(bracket) => self.close(bracket, span),
            TokenKind::Comma => self.comma(span),
        }
        self.last = end;
    }

    /// A value directly behind a value: notes the missing operator and goes on as if it were a product.
    fn last_step(&mut self, kind: &TokenKind, span: &Span) {
        let begins_value = match kind {
            TokenKind::BinaryOperator(_) | TokenKind::Close(_) | TokenKind::Comma => false,
            TokenKind::Open(Bracket::Round) => !self.follows_name(),
            _ => true,
        };
        if self.have_value && begins_value {
            self.errors.push(self.side_by_side(span));
            self.infix(BinaryOperator::Times);
        }
    }

    fn value(&mut self, syntax: Syntax, span: Span) {
        self.push(syntax, span);
        self.have_value = true;
    }

    fn push(&mut self, syntax: Syntax, span: Span) {
        self.operands.push(self.nodes.len());
        self.nodes.push(SyntaxNode { syntax, span, bracketed: false });
    }

    fn operator(&mut self, operator: BinaryOperator, span: Span) {
        match operator {
            BinaryOperator::Plus | BinaryOperator::Minus if !self.have_value => {
                self.pending.push(Pending::Sign { minus: operator == BinaryOperator::Minus, at: span.start });
            }
            _ => {
                self.demand_value(&span);
                self.infix(operator);
            }
        }
    }

    fn infix(&mut self, operator: BinaryOperator) {
        let tightness = operator.binding() + u8::from(operator == BinaryOperator::Power);
        self.reduce(tightness);
        self.pending.push(Pending::Infix(operator));
        self.have_value = false;
    }

    /// Notes a missing value before `span` and puts a broken one there.
    fn demand_value(&mut self, span: &Span) {
        if self.have_value {
            return;
        }
        self.errors.push(self.missing_value(span));
        self.value(Syntax::Broken, span.start..span.start);
    }

    fn missing_value(&self, span: &Span) -> FormulaError {
        let found = match &self.text[span.clone()] {
            "" => "the formula ends".to_owned(),
            sign => format!("`{sign}` stands"),
        };
        let message = format!("a value is missing where {found}");
        let error = FormulaError::new(Code::MissingValue, span.clone(), message);
        match &self.text[self.last.clone()] {
            "" => error.label("a number, a name or a bracket should stand before this"),
            sign => error
                .label("expected a number, a name or a bracket before this")
                .also(self.last.clone(), format!("a value should follow this `{sign}`")),
        }
    }

    fn side_by_side(&self, span: &Span) -> FormulaError {
        let first = self.operands.last().map_or(self.last.clone(), |id| self.nodes[*id].span.clone());
        let error = FormulaError::between(
            Code::MissingOperator,
            "two values stand side by side without an operator",
            vec![
                (span.clone(), "an operator should stand before this".into()),
                (first.clone(), String::new()),
            ],
        );
        error.help(self.operator_cure(&first, span))
    }

    fn operator_cure(&self, first: &Span, second: &Span) -> String {
        let last_node = self.operands.last().map(|id| &self.nodes[*id].syntax);
        let (left, right) = (&self.text[first.clone()], &self.text[second.clone()]);
        match last_node {
            Some(Syntax::Quantity { chain: Some(_), .. }) => {
                let joined = format!("{left}*{right}");
                format!(
                    "a product is written `{left} * {right}`; units are joined without spaces: `{joined}`"
                )
            }
            _ if matches!(right, "(" | "[") => format!("a product is written `{left}*{right}...`"),
            _ => format!("a product is written `{left}*{right}`"),
        }
    }

    fn follows_name(&self) -> bool {
        let Some(id) = self.operands.last() else { return false };
        let node = &self.nodes[*id];
        self.have_value && !node.bracketed && matches!(node.syntax, Syntax::Name(_)) && node.span == self.last
    }

    fn open(&mut self, bracket: Bracket, span: Span) {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            self.too_deep = true;
            self.errors.push(too_deep(span, MAX_DEPTH));
            return;
        }
        let function = self.follows_name().then(|| self.last.clone());
        if function.is_some() {
            // The name was taken for a value; it is the last node and nothing refers to it.
            self.operands.pop();
            self.nodes.pop();
        }
        let base = self.operands.len();
        self.pending.push(Pending::Open(Opening { bracket, span, function, base }));
        self.have_value = false;
    }

    fn comma(&mut self, span: Span) {
        self.demand_value(&span);
        self.reduce(0);
        let in_list = matches!(self.pending.last(), Some(Pending::Open(opening)) if opening.is_list());
        if !in_list {
            self.errors.push(self.stray_comma(&span));
            self.operands.pop();
        }
        self.have_value = false;
    }

    fn stray_comma(&self, comma: &Span) -> FormulaError {
        let after = &self.text[comma.end..];
        let digits = after.bytes().take_while(u8::is_ascii_digit).count();
        match self.number_before(comma) {
            Some(whole) if digits > 0 => self.decimal_comma(whole, comma.end..comma.end + digits),
            _ => FormulaError::new(Code::Comma, comma.clone(), "a comma separates nothing here")
                .label("outside of arguments and vectors")
                .help("arguments stand in `f(a, b)`, components in `[a, b]`"),
        }
    }

    /// The number without units that ends at the comma.
    fn number_before(&self, comma: &Span) -> Option<Span> {
        let mut node = &self.nodes[*self.operands.last()?];
        while let (Syntax::Sign { operand: last, .. } | Syntax::Infix(_, _, last), false) =
            (&node.syntax, node.bracketed)
        {
            node = &self.nodes[*last];
        }
        let bare = matches!(node.syntax, Syntax::Quantity { chain: None, .. }) && !node.bracketed;
        (bare && node.span.end == comma.start).then(|| node.span.clone())
    }

    fn decimal_comma(&self, whole: Span, fraction: Span) -> FormulaError {
        let (before, after) = (&self.text[whole.clone()], &self.text[fraction.clone()]);
        let grouped = self.text[fraction.end..].starts_with(['.', ',']) || before.contains('.');
        let error =
            FormulaError::new(Code::DecimalComma, whole.start..fraction.end, "a comma inside a number");
        match grouped {
            true => error
                .label("digits are not grouped")
                .help(format!("write the digits together: `{before}{after}...`")),
            false => error.label("numbers have a decimal point").help(format!("write `{before}.{after}`")),
        }
    }

    fn close(&mut self, bracket: Bracket, span: Span) {
        let count = self.operands.len();
        let empty = matches!(self.pending.last(), Some(Pending::Open(o)) if o.base == count && o.is_list());
        if !empty {
            self.demand_value(&span);
        }
        self.reduce(0);
        self.have_value = true;
        match self.pending.pop() {
            Some(Pending::Open(opening)) => {
                self.depth -= 1;
                self.errors.extend((opening.bracket != bracket).then(|| mismatch(&opening.span, &span)));
                self.enclose(opening, span.end);
            }
            _ => self.errors.push(unopened(self.text, span)),
        }
    }

    fn enclose(&mut self, opening: Opening, end: usize) {
        let start = opening.function.as_ref().unwrap_or(&opening.span).start;
        if !opening.is_list() {
            return self.bracket(start..end);
        }
        let parts = self.operands.split_off(opening.base);
        for part in &parts {
            self.stand(*part, Standing::Alone);
        }
        match opening.function {
            Some(name) => self.push(Syntax::Call(name, parts), start..end),
            None => self.vector(parts, start..end),
        }
    }

    fn vector(&mut self, parts: Vec<NodeId>, span: Span) {
        if !(2..=3).contains(&parts.len()) {
            let message = format!("a vector has 2 or 3 components, not {}", parts.len());
            self.errors.push(
                FormulaError::new(Code::Components, span.clone(), message)
                    .help("brackets around one value are round: `(a)`"),
            );
        }
        self.push(Syntax::Vector(parts), span);
    }

    fn bracket(&mut self, span: Span) {
        let Some(&id) = self.operands.last() else { return };
        self.stand(id, Standing::Bracketed);
        self.nodes[id].span = span;
        self.nodes[id].bracketed = true;
    }

    /// Tells a quantity, behind its signs, what stands around it.
    fn stand(&mut self, mut id: NodeId, around: Standing) {
        while let Syntax::Sign { operand, .. } = self.nodes[id].syntax {
            id = operand;
        }
        if let Syntax::Quantity { standing: standing @ Standing::Within, .. } = &mut self.nodes[id].syntax {
            *standing = around;
        }
    }

    /// Builds what waits and binds at least as tightly as `tightness`.
    fn reduce(&mut self, tightness: u8) {
        loop {
            match self.pending.last() {
                Some(&Pending::Infix(operator)) if operator.binding() >= tightness => {
                    self.build_infix(operator)
                }
                Some(&Pending::Sign { minus, at }) if SIGN_BINDING >= tightness => self.build_sign(minus, at),
                _ => return,
            }
            self.pending.pop();
        }
    }

    fn build_infix(&mut self, operator: BinaryOperator) {
        let (Some(right), Some(left)) = (self.operands.pop(), self.operands.pop()) else { return };
        self.errors.extend(self.misread(operator, left));
        let span = self.nodes[left].span.start..self.nodes[right].span.end;
        self.push(Syntax::Infix(operator, left, right), span);
    }

    fn build_sign(&mut self, minus: bool, at: usize) {
        let Some(operand) = self.operands.pop() else { return };
        let span = at..self.nodes[operand].span.end;
        self.push(Syntax::Sign { minus, operand }, span);
    }

    /// Formulas that have a meaning, but not the one a reader sees.
    fn misread(&self, operator: BinaryOperator, left: NodeId) -> Option<FormulaError> {
        let node = &self.nodes[left];
        match &node.syntax {
            _ if node.bracketed => None,
            Syntax::Quantity { chain: Some(_), .. } if operator == BinaryOperator::Power => {
                Some(self.power_of_quantity(&node.span))
            }
            Syntax::Infix(inner, ..) if inner.compares() && operator.compares() => Some(chained(&node.span)),
            _ => None,
        }
    }

    fn power_of_quantity(&self, span: &Span) -> FormulaError {
        let written = &self.text[span.clone()];
        FormulaError::new(
            Code::PowerOfQuantity,
            span.clone(),
            "this power is either of the unit or of the whole quantity",
        )
        .help(format!(
            "write `{written}^2`, without spaces, for the unit and `({written})^2` for the quantity"
        ))
    }

    fn finish(mut self) -> Result<Tree, Vec<FormulaError>> {
        let end = self.text.len();
        self.demand_value(&(end..end));
        self.reduce(0);
        let open = self.pending.iter().find_map(|pending| match pending {
            Pending::Open(opening) => Some(opening.span.clone()),
            _ => None,
        });
        self.errors.extend(open.map(|span| unclosed(self.text, span)));
        match self.operands.last() {
            Some(&root) if self.errors.is_empty() => {
                self.stand(root, Standing::Alone);
                Ok(Tree { nodes: self.nodes })
            }
            _ => Err(self.errors),
        }
    }
}
