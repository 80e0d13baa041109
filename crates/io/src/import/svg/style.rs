//! The few properties that say what of an SVG is drawn: from attributes, `style` attributes and simple style sheets.

use roxmltree::Node;

/// The properties that an element hands down.
#[allow(clippy::struct_excessive_bools, reason = "four independent properties, each with a name of its own")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Style {
    /// Whether the inside is painted.
    pub(super) filled: bool,
    /// Whether the outline is painted.
    pub(super) stroked: bool,
    /// Whether the fill rule is even-odd.
    pub(super) even_odd: bool,
    /// Whether it is shown.
    pub(super) visible: bool,
}

impl Default for Style {
    fn default() -> Self {
        Self { filled: true, stroked: false, even_odd: false, visible: true }
    }
}

/// Style sheet rules with a single class, id or element name as selector; others are ignored.
#[derive(Clone, Debug, Default)]
pub(super) struct Sheet {
    rules: Vec<(String, String)>,
}

impl Sheet {
    /// The rules of every `style` element.
    pub(super) fn of(root: Node<'_, '_>) -> Self {
        let mut sheet = Self::default();
        for style in root.descendants().filter(|n| n.has_tag_name("style") || n.tag_name().name() == "style") {
            let css: String = style.descendants().filter_map(|n| n.text().filter(|_| n.is_text())).collect();
            sheet.add(&css);
        }
        sheet
    }

    fn add(&mut self, css: &str) {
        let plain = without_comments(css);
        for rule in plain.split('}') {
            let Some((selectors, body)) = rule.split_once('{') else { continue };
            for selector in selectors.split(',') {
                self.rules.push((selector.trim().to_owned(), body.to_owned()));
            }
        }
    }

    fn declarations<'a>(&'a self, node: Node<'a, '_>) -> impl Iterator<Item = &'a str> {
        let classes = node.attribute("class").unwrap_or_default();
        let (id, tag) = (node.attribute("id"), node.tag_name().name());
        let matches = move |selector: &str| match selector.split_at_checked(1) {
            Some((".", class)) => classes.split_ascii_whitespace().any(|c| c == class),
            Some(("#", wanted)) => id == Some(wanted),
            _ => selector == tag || selector == "*",
        };
        self.rules.iter().filter(move |(selector, _)| matches(selector)).map(|(_, body)| body.as_str())
    }
}

fn without_comments(css: &str) -> String {
    let mut plain = String::with_capacity(css.len());
    let mut rest = css;
    while let Some((before, after)) = rest.split_once("/*") {
        plain.push_str(before);
        rest = after.split_once("*/").map_or("", |(_, tail)| tail);
    }
    plain.push_str(rest);
    plain
}

impl Style {
    /// The style of a child: attributes, then style sheets, then its own `style` attribute, each over the one before.
    ///
    /// `None` where it isn't displayed at all, nor is anything in it.
    pub(super) fn of_child(self, node: Node<'_, '_>, sheet: &Sheet) -> Option<Self> {
        const PROPERTIES: [&str; 5] = ["fill", "stroke", "fill-rule", "visibility", "display"];
        let mut style = self;
        let mut displayed = true;
        let mut set = |property: &str, value: &str| {
            let value = value.trim().trim_end_matches("!important").trim_end();
            match (property, value) {
                (_, "inherit") => {}
                ("fill", paint) => style.filled = !is_none(paint),
                ("stroke", paint) => style.stroked = !is_none(paint),
                ("fill-rule", rule) => style.even_odd = rule == "evenodd",
                ("visibility", how) => style.visible = how == "visible",
                ("display", how) => displayed = how != "none",
                _ => {}
            }
        };
        for property in PROPERTIES {
            if let Some(value) = node.attribute(property) {
                set(property, value);
            }
        }
        for body in sheet.declarations(node).chain(node.attribute("style")) {
            for (property, value) in body.split(';').filter_map(|d| d.split_once(':')) {
                set(property.trim(), value);
            }
        }
        displayed.then_some(style)
    }
}

fn is_none(paint: &str) -> bool {
    paint == "none" || paint == "transparent"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn style_of(svg: &str) -> Option<Style> {
        let document = roxmltree::Document::parse(svg).unwrap();
        let sheet = Sheet::of(document.root_element());
        let node = document.descendants().find(|n| n.has_tag_name("path")).unwrap();
        Style::default().of_child(node, &sheet)
    }

    #[test]
    fn the_nearer_word_wins() {
        let sheet = "<style>.a{fill:none;stroke:red} /* .a{display:none} */</style>";
        let style = style_of(&format!("<svg>{sheet}<path class='b a' fill='red'/></svg>")).unwrap();
        assert!(!style.filled && style.stroked);
        let style = style_of(&format!("<svg>{sheet}<path class='a' style='fill: blue; fill-rule:evenodd'/></svg>"));
        assert!(style.unwrap().filled && style.unwrap().even_odd);
        assert_eq!(style_of("<svg><path style='display : none'/></svg>"), None);
    }
}
