/* What the theme leaves to readers by keys and by ear; it makes some of these elements after the page has been read. */
const each = (selector, change) => document.querySelectorAll(selector).forEach(change);
const reach = () => each(".md-typeset__scrollwrap, .formula, .highlight code, .doc-signature code", box => {
  if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
});
const name = () => {
  each(".md-search", dialog => dialog.ariaLabel = "Search");
  each(".md-path", path => path.ariaLabel = "Path");
  each(".md-code__nav", buttons => buttons.role = "presentation");
};
const mend = () => { reach(); name(); };
addEventListener("load", () => { mend(); new MutationObserver(mend).observe(document.body, { childList: true, subtree: true }); });
addEventListener("resize", reach);
