# Homebrew, on Linux: brew install --formula ./mr-tools.rb
class MrTools < Formula
  desc "Tools in pipes that edit meshes with their detail and make light surfaces of scans"
  homepage "@URL@"
  url "@URL@/@BINARY@.tar.gz"
  version "@VERSION@"
  sha256 "@SHA256@"
  license all_of: ["MIT", "GPL-2.0-or-later"]

  depends_on arch: :x86_64
  depends_on :linux

  def install
    prefix.install Dir["*"]
  end

  test do
    assert_match "162 vertices", shell_output("#{bin}/mr-make sphere -n 200 | #{bin}/mr-smooth | #{bin}/mr-info")
  end
end
